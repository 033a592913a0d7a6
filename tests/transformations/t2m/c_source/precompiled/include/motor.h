#ifndef MOTOR_H
#define MOTOR_H
#include "board.h"
void motor_speed(int left, int right);
#define STOP() motor_speed(0, 0)
#endif
