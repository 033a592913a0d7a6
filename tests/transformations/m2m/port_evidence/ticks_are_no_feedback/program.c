#include "simpletools.h"
#include "abdrive360.h"
int main() { drive_goto(64, 64); drive_speed(20, 20); }
