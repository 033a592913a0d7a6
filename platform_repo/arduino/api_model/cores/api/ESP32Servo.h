// The library of the ESP32 has the class of Servo.h.
#pragma once
#include "Servo.h"
