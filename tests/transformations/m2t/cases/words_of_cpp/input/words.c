#include "simpletools.h"

#define SET_NEW(x) new = (x)

struct class { int this; struct class *private; };
int new;
static int template[2];

int delete(int try)
{
  return try + new;
}

int main()
{
  struct class object;
  int public = 2;
  object.this = public;
  object.private = &object;
  while (1) {
    SET_NEW(delete(1));
    template[0] = object.this + object.private->this;
    pause(template[0]);
  }
}
