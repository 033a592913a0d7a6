/* Minimal fenv.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_FENV_H
#define ROBOSMI_FENV_H
typedef int fenv_t;
typedef int fexcept_t;
#define FE_TONEAREST 0
#define FE_DOWNWARD 1
#define FE_UPWARD 2
#define FE_TOWARDZERO 3
int fegetround(void);
int fesetround(int mode);
int feclearexcept(int mask);
int fetestexcept(int mask);
#endif
