#include "simpletools.h"
#include "servo.h"
#include "adapters.h"
#include "Print.h"
#include "Arduino.h"
#include "Servo.h"
int main() { servo_angle(16, QA); print("%d %d %d\n", QA, QB, QC + QD); }
