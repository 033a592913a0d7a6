/* Minimal locale.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_LOCALE_H
#define ROBOSMI_LOCALE_H
struct lconv { char *decimal_point; char *thousands_sep; };
#define LC_ALL 0
#define LC_COLLATE 1
#define LC_CTYPE 2
#define LC_MONETARY 3
#define LC_NUMERIC 4
#define LC_TIME 5
char *setlocale(int category, const char *locale);
struct lconv *localeconv(void);
#endif
