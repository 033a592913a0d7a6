#include "Servo.h"

#include "../../chip/board.h"
#include "pins.h"

uint8_t Servo::attach(int pin, int min, int max) {
  detach();
  lowest = min;
  highest = max;
  pinMode(pin, OUTPUT);
  place = apiPin(pin);
  board_servo(place, width);
  return place;
}

void Servo::detach() {
  if (place >= 0) board_servo(place, 0);
  place = -1;
}

void Servo::write(int value) {
  writeMicroseconds(value < MIN_PULSE_WIDTH ? map(constrain(value, 0, 180), 0, 180, lowest, highest) : value);
}

void Servo::writeMicroseconds(int value) {
  width = constrain(value, lowest, highest);
  if (place >= 0) board_servo(place, width);
}
