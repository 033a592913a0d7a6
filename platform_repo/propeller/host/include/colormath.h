/* colormath.h of the Simple Libraries: colours as numbers. */
#ifndef ROBOSMI_COLORMATH_H
#define ROBOSMI_COLORMATH_H
#include <propeller.h>
#include <stdlib.h>
int remapColor888to565(int c);
#endif
