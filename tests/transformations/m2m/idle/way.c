#include "simpletools.h"
#include "abdrive.h"
int main() { drive_goto(40, 40); }
