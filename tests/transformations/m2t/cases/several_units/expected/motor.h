#pragma once
#define MOTOR_PIN 14
extern int32_t steps;
extern int32_t speed;
void motor_start(int32_t p);
void motor_step(int32_t n);
