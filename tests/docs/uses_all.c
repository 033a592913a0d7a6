/* Has something for each list that `analyse` gives. */
#include <stdlib.h>
#include "simpletools.h"
#include "strange.h"

#define TWICE(x) ((x) + (x))
#define BLINK high(26)

struct pair { int left, right; };
static int limit = 3;
terminal *line;

int doubled(int value);

void other(void *parameter) {
  (void)parameter;
}

int doubled(int value) {
  return TWICE(value);
}

int main(int argc, char *argv[]) {
  struct pair wheels = { abs(-3), doubled(limit) };
  cog_run(other, 40);
  unheard_of(wheels.left);
  while (1) {
    BLINK;
    low(26);
    set_outputs(7, 0, OUTA);
  }
}
