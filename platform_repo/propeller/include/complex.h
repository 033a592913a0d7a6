/* Minimal complex.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_COMPLEX_H
#define ROBOSMI_COMPLEX_H
#define complex _Complex
#define I (__extension__ 1.0iF)
double cabs(double complex z);
double creal(double complex z);
double cimag(double complex z);
#endif
