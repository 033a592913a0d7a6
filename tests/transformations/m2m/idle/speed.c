#include "simpletools.h"
#include "abdrive.h"
int main() { drive_speed(40, 40); }
