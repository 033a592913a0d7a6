/* Minimal float.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_FLOAT_H
#define ROBOSMI_FLOAT_H
#define FLT_RADIX 2
#define FLT_DIG 6
#define FLT_MANT_DIG 24
#define FLT_MAX_EXP 128
#define FLT_MIN_EXP (-125)
#define FLT_EPSILON 1.19209290e-7f
#define FLT_MAX 3.40282347e+38f
#define FLT_MIN 1.17549435e-38f
#define DBL_DIG 6
#define DBL_MANT_DIG 24
#define DBL_EPSILON 1.19209290e-7
#define DBL_MAX 3.40282347e+38
#define DBL_MIN 1.17549435e-38
#endif
