// #include <Servo.h> in a comment needs no library
#if defined(NEVER_DEFINED)
#include <DHT.h>
#endif
#include <Unheard_Of.h>

void setup() {}

void loop() {}
