#include <math.h>
#define SPOKES 8
extern int wheels;
int spin(int times);
