#include "simpletools.h"
#include "led.h"
Led::Led(int p) : pin(p) {}
void Led::on() { high(pin); }
