#include <Arduino_FreeRTOS.h>
#include <Keypad.h>
#include <string.h>
#include <avr/io.h>
void setup() {}
void loop() {}
