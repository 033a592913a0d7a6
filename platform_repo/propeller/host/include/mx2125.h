/* mx2125.h of the Simple Libraries: an accelerometer of two axes with pulses. */
#ifndef MX2125_H
#define MX2125_H
#include "simpletools.h"
int mx_accel(int axisPin);
int mx_rotate(int xPin, int yPin);
int mx_tilt(int axisPin);
#endif
