#include "simpletools.h"
const int LED = 8;
struct B { int pin; B(int p) : pin(p) {} };
struct Lamp : B { Lamp(int p = LED) : B(p) {} void on() { high(pin); } };
Lamp lamp;
int main() { low(LED); while (1) { lamp.on(); pause(100); low(LED); pause(100); } }
