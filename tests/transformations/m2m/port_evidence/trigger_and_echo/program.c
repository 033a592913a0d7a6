#include "simpletools.h"
const int trig = 5, echo = 6;
int main() { low(trig); pulse_out(trig, 10); print("%d", pulse_in(echo, 1)); }
