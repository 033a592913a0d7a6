#include "simpletools.h"
int main() { high(9); print("%d", rc_time(9, 1)); high(5); print("%d", rc_time(5, 1)); }
