/* mx2125.h. Sources: libmx2125 (mx2125_accel.c, mx2125_rotate.c, mx2125_tilt.c). */
#include <math.h>
#include "mx2125.h"

enum { LEVEL = 5000, ONE_G = 1250 };  /* microseconds */
static const float DEGREES = 57.29577951f;

int mx_accel(int axisPin) { return pulse_in(axisPin, 1) - LEVEL; }

int mx_rotate(int xPin, int yPin) {
  float x = mx_accel(xPin), y = mx_accel(yPin);
  int degrees = (int)(atan2f(y, x) * DEGREES);
  return degrees < 0 ? degrees + 360 : degrees;
}

int mx_tilt(int axisPin) {
  int g = mx_accel(axisPin);
  if (g > ONE_G) g = ONE_G;
  if (g < -ONE_G) g = -ONE_G;
  return (int)(asinf((float)g / ONE_G) * DEGREES);
}
