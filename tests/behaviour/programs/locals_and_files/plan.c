#include "plan.h"
float plan[] = {8.0f, 9.0f};
int shared = 11;
unsigned char serial[3];
static int inner = 5;
void make(float *to, unsigned char *from) { to[0] += plan[0]; serial[0] = from[1]; plan[1] += 1; }
int other(void) { shared++; inner++; return serial[0] + shared + inner + (int)plan[1]; }
