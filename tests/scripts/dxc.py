#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Brings DXC, Microsoft's compiler for HLSL, which Debian has not: the library in the source package `compushady` of PyPI.

usage: dxc.py FOLDER      then PATH=FOLDER:$PATH ctest --preset dev -R web.vat

FOLDER gets a program `dxc` that takes DXC's options, a file, and -Fo. It wants Linux on x86-64 or ARM64, pip and g++;
the package has 67 MB.
"""
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ("compushady", "0.17.5", "5052caf9e955d8e7a48e22f536e82b44b72e83af46e824a9e99157c7809de691")
PROGRAM = r"""
#include "dxcapi.h"
#include <dlfcn.h>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>
int main(int argc, char** argv) {
  std::vector<std::wstring> words;
  const char *out = nullptr, *file = argc > 1 ? argv[argc - 1] : "";
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "-Fo") == 0)
      out = argv[++i];
    else
      words.emplace_back(argv[i], argv[i] + std::strlen(argv[i]));
  }
  std::vector<LPCWSTR> options;
  for (const std::wstring& word : words)
    options.push_back(word.c_str());
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  void* library = dlopen(LIBRARY, RTLD_NOW);
  if (library == nullptr || !stream)
    return std::fprintf(stderr, "dxc: %s\n", library == nullptr ? dlerror() : file), 1;
  auto create = reinterpret_cast<DxcCreateInstanceProc>(dlsym(library, "DxcCreateInstance"));
  IDxcCompiler3* compiler = nullptr;
  IDxcResult* result = nullptr;
  IDxcBlobUtf8* errors = nullptr;
  IDxcBlob* object = nullptr;
  const DxcBuffer source = {text.data(), text.size(), DXC_CP_UTF8};
  HRESULT status = create(CLSID_DxcCompiler, __uuidof(IDxcCompiler3), reinterpret_cast<void**>(&compiler));
  if (SUCCEEDED(status))
    status = compiler->Compile(&source, options.data(), static_cast<UINT32>(options.size()), nullptr, __uuidof(IDxcResult), reinterpret_cast<void**>(&result));
  if (SUCCEEDED(status)) {
    result->GetOutput(DXC_OUT_ERRORS, __uuidof(IDxcBlobUtf8), reinterpret_cast<void**>(&errors), nullptr);
    if (errors != nullptr && errors->GetStringLength() > 0)
      std::fprintf(stderr, "%s", errors->GetStringPointer());
    result->GetStatus(&status);
  }
  if (FAILED(status) || FAILED(result->GetOutput(DXC_OUT_OBJECT, __uuidof(IDxcBlob), reinterpret_cast<void**>(&object), nullptr)) ||
      object == nullptr || object->GetBufferSize() == 0)
    return std::fprintf(stderr, "dxc: %s is not compiled\n", file), 1;
  if (out != nullptr)
    std::ofstream(out, std::ios::binary).write(static_cast<const char*>(object->GetBufferPointer()), static_cast<std::streamsize>(object->GetBufferSize()));
  return 0;
}
"""


def main():
    if len(sys.argv) != 2 or sys.argv[1] == "--help":
        sys.exit(__doc__)
    cpu = {"x86_64": "x86_64", "aarch64": "aarch64"}.get(platform.machine())
    if sys.platform != "linux" or cpu is None:
        sys.exit("the package has DXC for Linux on x86-64 and ARM64 alone")
    folder = pathlib.Path(sys.argv[1]).resolve()
    source = folder / "compushady"
    if not source.is_dir():
        subprocess.run([sys.executable, ROOT / "cmake/fetch_source.py", *PACKAGE, "compushady/backends", source], check=True)
    subprocess.run(["g++", "-std=c++17", "-O1", "-w", "-x", "c++", "-", "-I", source, f'-DLIBRARY="{source}/libdxcompiler_{cpu}.so.3.7"', "-o",
                    folder / "dxc", "-ldl"], input=PROGRAM, text=True, check=True)
    print(f"PATH={folder}:$PATH has dxc")


if __name__ == "__main__":
    main()
