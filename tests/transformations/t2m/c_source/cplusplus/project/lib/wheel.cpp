#include "wheel.h"
Wheel::Wheel(int pin) : pin_(pin) { low(pin_); }
void Wheel::turn(int step) { pulse_out(pin_, step * 10); }
