#pragma once
#define MOTOR_PIN 14
extern int steps;
extern int speed;
void motor_start(int p);
void motor_step(int n);
