#include "simpletools.h"

static int counter = 1;
extern const int limit;

int main(void)
{
  while (1) {
    counter = twice(counter) % limit;
    show();
  }
}
