/* math.h with doubles of 4 bytes: each function is the one for float. */
#include <math.h>

#define OF_ONE(name) double name(double x) { return name##f(x); }
#define OF_TWO(name) double name(double x, double y) { return name##f(x, y); }

OF_ONE(acos) OF_ONE(asin) OF_ONE(atan) OF_ONE(cos) OF_ONE(sin) OF_ONE(tan) OF_ONE(cosh) OF_ONE(sinh) OF_ONE(tanh)
OF_ONE(acosh) OF_ONE(asinh) OF_ONE(atanh) OF_ONE(exp) OF_ONE(exp2) OF_ONE(expm1) OF_ONE(log) OF_ONE(log10) OF_ONE(log1p)
OF_ONE(log2) OF_ONE(sqrt) OF_ONE(cbrt) OF_ONE(fabs) OF_ONE(ceil) OF_ONE(floor) OF_ONE(round) OF_ONE(trunc) OF_ONE(rint)
OF_TWO(atan2) OF_TWO(pow) OF_TWO(fmod) OF_TWO(hypot) OF_TWO(fmax) OF_TWO(fmin) OF_TWO(fdim) OF_TWO(copysign)
