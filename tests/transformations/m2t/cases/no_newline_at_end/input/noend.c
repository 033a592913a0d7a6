#include "simpletools.h"
int n;
int main() { n = 1; while (1) { pause(n); } }