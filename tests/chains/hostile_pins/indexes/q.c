#include "simpletools.h"
int q[2][2] = {{3,4},{5,6}};
int main(void) { high(1[q][0]); high((0[q])[1]); low(q[0][1[q[0]] - 4]); while (1) pause(100); }
