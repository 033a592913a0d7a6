#include "board.h"
#include "nowhere.h"
#include "motor.h"
int main() { motor_speed(LED, 0); elsewhere(); }
