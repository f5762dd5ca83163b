/* The library of Windows that Rust's standard library takes random numbers from, for versions of Wine without it (see test_binaries.py). */
#include <windows.h>
#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(BYTE *bytes, SIZE_T count) { return RtlGenRandom(bytes, (ULONG)count); }
