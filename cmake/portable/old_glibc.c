/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: The anicodec authors
 *
 * Functions of later glibc that programs linked with glibc_stubs.py bring along. */
#define _GNU_SOURCE
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

/* The C++ library asks whether it may do without atomic operations. It may not. */
char __libc_single_threaded = 0;

int __xstat(int version, const char* path, struct stat* to);
int __lxstat(int version, const char* path, struct stat* to);
int __fxstat(int version, int file, struct stat* to);
int __fxstat64(int version, int file, struct stat64* to);

/* The layout of struct stat on 64-bit machines. */
#ifdef __x86_64__
enum { kStatVersion = 1 };
#else
enum { kStatVersion = 0 };
#endif

int stat(const char* path, struct stat* to) {
  return __xstat(kStatVersion, path, to);
}

int lstat(const char* path, struct stat* to) {
  return __lxstat(kStatVersion, path, to);
}

int fstat(int file, struct stat* to) {
  return __fxstat(kStatVersion, file, to);
}

int fstat64(int file, struct stat64* to) {
  return __fxstat64(kStatVersion, file, to);
}

/* Kernels before 5.9 lack it, too. */
int close_range(unsigned first, unsigned last, int flags) {
  if (syscall(SYS_close_range, first, last, flags) == 0)
    return 0;
  const long most = sysconf(_SC_OPEN_MAX);
  for (unsigned file = first; file <= last && (long)file < most; ++file)
    close((int)file);
  return 0;
}

/* Waits by the clock of the day, which nobody should set meanwhile; callers look at their own clock afterwards. */
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* until) {
  struct timespec there, here;
  clock_gettime(clock, &there);
  clock_gettime(CLOCK_REALTIME, &here);
  here.tv_sec += until->tv_sec - there.tv_sec;
  here.tv_nsec += until->tv_nsec - there.tv_nsec;
  const long second = 1000000000;
  if (here.tv_nsec < 0) {
    here.tv_nsec += second;
    --here.tv_sec;
  } else if (here.tv_nsec >= second) {
    here.tv_nsec -= second;
    ++here.tv_sec;
  }
  return pthread_cond_timedwait(condition, mutex, &here);
}

uint32_t arc4random(void) {
  uint32_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number)
    _exit(70);
  return number;
}

/* Debian's libpng16.a is no position-independent code, so that a variable of its own must stand for stderr; prepare.sh renames
 * it there. */
FILE* anicodec_png_stderr;

__attribute__((constructor)) static void set_png_stderr(void) {
  anicodec_png_stderr = stderr;
}
