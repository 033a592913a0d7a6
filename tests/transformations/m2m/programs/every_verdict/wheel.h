#include <math.h>
extern int wheels;
int spin(int times);
