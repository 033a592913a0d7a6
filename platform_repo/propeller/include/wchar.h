/* Minimal wchar.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_WCHAR_H
#define ROBOSMI_WCHAR_H
#include <stddef.h>
#include <stdio.h>
typedef unsigned int wint_t;
typedef struct { int state; } mbstate_t;
#define WEOF ((wint_t)-1)
size_t wcslen(const wchar_t *s);
wchar_t *wcscpy(wchar_t *to, const wchar_t *from);
wchar_t *wcscat(wchar_t *to, const wchar_t *from);
int wcscmp(const wchar_t *a, const wchar_t *b);
wint_t fgetwc(FILE *stream);
wint_t fputwc(wchar_t c, FILE *stream);
int wprintf(const wchar_t *format, ...);
#endif
