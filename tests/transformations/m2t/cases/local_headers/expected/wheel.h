#ifndef WHEEL_H
#define WHEEL_H
#include "config.h"

struct wheel { int32_t pin; int32_t turns; };

static inline void start(struct wheel *w) { low(port(w->pin)); }

static void turn(struct wheel *w)
{
  high(port(w->pin));
  w->turns++;
}
#endif
