#include "Servo.h"
int unused_and_warned_about() { int unused; return 1; }
