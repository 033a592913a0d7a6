/* ArduinoCore-avr 1.8.6, Printable.h: names and signatures. */
#pragma once
#include <stddef.h>
class Print;
class Printable {
public:
  virtual size_t printTo(Print &p) const = 0;
};
