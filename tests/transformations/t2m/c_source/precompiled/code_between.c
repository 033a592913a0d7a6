#include "board.h"
int before;
#include "motor.h"
int main() { motor_speed(before, SPEED); }
