/* Minimal wctype.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_WCTYPE_H
#define ROBOSMI_WCTYPE_H
#include <wchar.h>
typedef unsigned long wctype_t;
int iswalnum(wint_t c);
int iswalpha(wint_t c);
int iswdigit(wint_t c);
int iswlower(wint_t c);
int iswspace(wint_t c);
int iswupper(wint_t c);
wint_t towlower(wint_t c);
wint_t towupper(wint_t c);
#endif
