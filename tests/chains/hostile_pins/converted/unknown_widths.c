#include "simpletools.h"

struct bits { unsigned narrow : 2; int pin; };
struct bits rows[] = { 5, 7, 6, 8 };
union both { unsigned narrow : 2; unsigned whole; } place;
struct field { unsigned pin : 3; } field;

int main(void) {
  int number = 4;
  number += input(2);
  field.pin = number;
  place.whole = 5;
  high(rows[0].narrow);
  high(place.narrow);
  high(field.pin);
  while (1) pause(100);
}
