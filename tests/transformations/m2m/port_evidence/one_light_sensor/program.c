#include "simpletools.h"
int main() { high(9); print("%d", rc_time(9, 1)); high(26); }
