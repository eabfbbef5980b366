// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A library for LD_PRELOAD that tells power_loss.py of each call that changes or flushes files: a message on the
// socket FILE_WATCH_FD, answered once power_loss.py has seen the files. "o" after a change, "r" after a rename,
// "s INODE" after a flush. With FILE_WATCH_FAIL=N, the rename of that number fails, and no other one.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static pthread_mutex_t watching = PTHREAD_MUTEX_INITIALIZER;

static void tell(const char* message) {
  const char* number = getenv("FILE_WATCH_FD");
  const int before = errno;
  char answer;
  if (number) {
    const int channel = atoi(number);
    while (write(channel, message, strlen(message)) < 0 && errno == EINTR) {
    }
    while (read(channel, &answer, 1) < 0 && errno == EINTR) {
    }
  }
  errno = before;
}

// One call at a time, so that the state seen after it is its work.
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define TOLD(type, message, call)  \
  pthread_mutex_lock(&watching);   \
  type result = (call);            \
  tell(message);                   \
  pthread_mutex_unlock(&watching); \
  return result

static int creates(int flags) {
  return (flags & (O_CREAT | O_TRUNC)) != 0;
}

#define OPEN(name)                                                 \
  int name(const char* path, int flags, ...) {                     \
    va_list rest;                                                  \
    va_start(rest, flags);                                         \
    const mode_t mode = creates(flags) ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                  \
    if (!creates(flags))                                           \
      return REAL(name)(path, flags);                              \
    TOLD(int, "o", REAL(name)(path, flags, mode));                 \
  }
OPEN(open)
OPEN(open64)

#define OPEN_AT(name)                                              \
  int name(int folder, const char* path, int flags, ...) {         \
    va_list rest;                                                  \
    va_start(rest, flags);                                         \
    const mode_t mode = creates(flags) ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                  \
    if (!creates(flags))                                           \
      return REAL(name)(folder, path, flags);                      \
    TOLD(int, "o", REAL(name)(folder, path, flags, mode));         \
  }
OPEN_AT(openat)
OPEN_AT(openat64)

#define OPEN_STREAM(name)                          \
  FILE* name(const char* path, const char* mode) { \
    if (mode[0] == 'r')                            \
      return REAL(name)(path, mode);               \
    TOLD(FILE*, "o", REAL(name)(path, mode));      \
  }
OPEN_STREAM(fopen)
OPEN_STREAM(fopen64)

int mkdir(const char* path, mode_t mode) {
  TOLD(int, "o", REAL(mkdir)(path, mode));
}

char* mkdtemp(char* path) {
  TOLD(char*, "o", REAL(mkdtemp)(path));
}

int link(const char* from, const char* to) {
  TOLD(int, "o", REAL(link)(from, to));
}

int unlink(const char* path) {
  TOLD(int, "o", REAL(unlink)(path));
}

int unlinkat(int folder, const char* path, int flags) {
  TOLD(int, "o", REAL(unlinkat)(folder, path, flags));
}

int rmdir(const char* path) {
  TOLD(int, "o", REAL(rmdir)(path));
}

int ftruncate(int file, off_t size) {
  TOLD(int, "o", REAL(ftruncate)(file, size));
}

int truncate(const char* path, off_t size) {
  TOLD(int, "o", REAL(truncate)(path, size));
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  TOLD(ssize_t, "o", REAL(pwrite)(file, bytes, size, at));
}

int fclose(FILE* file) {
  TOLD(int, "o", REAL(fclose)(file));
}

static int fails(void) {
  static int count;
  const char* number = getenv("FILE_WATCH_FAIL");
  return number && ++count == atoi(number);
}

#define RENAME(call)               \
  pthread_mutex_lock(&watching);   \
  tell("o");                       \
  int result = -1;                 \
  if (fails())                     \
    errno = EIO;                   \
  else                             \
    result = (call);               \
  tell("r");                       \
  pthread_mutex_unlock(&watching); \
  return result

int rename(const char* from, const char* to) {
  RENAME(REAL(rename)(from, to));
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  RENAME(REAL(renameat)(from_folder, from, to_folder, to));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  RENAME(REAL(renameat2)(from_folder, from, to_folder, to, flags));
}

#define FLUSH(name)                                                                   \
  int name(int file) {                                                                \
    struct stat status;                                                               \
    char message[32];                                                                 \
    pthread_mutex_lock(&watching);                                                    \
    tell("o");                                                                        \
    const int result = REAL(name)(file);                                              \
    if (result == 0 && fstat(file, &status) == 0) {                                   \
      snprintf(message, sizeof message, "s %llu", (unsigned long long)status.st_ino); \
      tell(message);                                                                  \
    }                                                                                 \
    pthread_mutex_unlock(&watching);                                                  \
    return result;                                                                    \
  }
FLUSH(fsync)
FLUSH(fdatasync)
