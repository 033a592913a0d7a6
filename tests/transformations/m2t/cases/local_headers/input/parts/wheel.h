#ifndef WHEEL_H
#define WHEEL_H
#include "simpletools.h"
#include "../config.h"

struct wheel { int pin; int turns; };

static inline void start(struct wheel *w) { low(w->pin); }

static void turn(struct wheel *w)
{
  high(w->pin);
  w->turns++;
}
#endif
