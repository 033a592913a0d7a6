/* Minimal stddef.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_STDDEF_H
#define ROBOSMI_STDDEF_H
typedef __SIZE_TYPE__ size_t;
typedef __PTRDIFF_TYPE__ ptrdiff_t;
#ifndef __cplusplus
typedef __WCHAR_TYPE__ wchar_t;
#endif
#define NULL ((void *)0)
#define offsetof(type, member) __builtin_offsetof(type, member)
#endif
