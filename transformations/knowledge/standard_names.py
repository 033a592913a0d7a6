"""Names that the C standard fixes, each with a declaration for the parser alone. Platforms' names are data of the repository."""

from __future__ import annotations

STANDARD_NAMES = {
    "NULL": "#define NULL ((void *)0)",
    "true": "#define true 1",
    "false": "#define false 0",
    "bool": "typedef _Bool bool;",
    "size_t": "typedef __SIZE_TYPE__ size_t;",
    "ssize_t": "typedef int ssize_t;",
    "ptrdiff_t": "typedef int ptrdiff_t;",
    "wchar_t": "typedef __WCHAR_TYPE__ wchar_t;",
    "FILE": "typedef struct robosmi_file FILE;",
    "EOF": "#define EOF (-1)",
    "stdin": "extern struct robosmi_file *stdin;",
    "stdout": "extern struct robosmi_file *stdout;",
    "stderr": "extern struct robosmi_file *stderr;",
    "va_list": "typedef __builtin_va_list va_list;",
    "int8_t": "typedef signed char int8_t;",
    "uint8_t": "typedef unsigned char uint8_t;",
    "int16_t": "typedef short int16_t;",
    "uint16_t": "typedef unsigned short uint16_t;",
    "int32_t": "typedef int int32_t;",
    "uint32_t": "typedef unsigned int uint32_t;",
    "int64_t": "typedef long long int64_t;",
    "uint64_t": "typedef unsigned long long uint64_t;",
    "intptr_t": "typedef int intptr_t;",
    "uintptr_t": "typedef unsigned int uintptr_t;",
    "time_t": "typedef long time_t;",
    "clock_t": "typedef unsigned long clock_t;",
    "errno": "extern int errno;",
    "INT_MAX": "#define INT_MAX 2147483647",
    "INT_MIN": "#define INT_MIN (-2147483647 - 1)",
    "M_PI": "#define M_PI 3.14159265358979323846",
    "RAND_MAX": "#define RAND_MAX 32767",
}
"""What the standard fixes about names that arrive through platform headers, so that types keep their width."""
