// ports 1 4 9
#include "simpletools.h"
typedef struct { int led; unsigned mask; } Lamp;
Lamp lamps[] = {{1, 1 << 1}, {4, 1 << 4}, {9, 0}};
void set_up(Lamp *lamp) { lamp->mask = 1u << lamp->led; DIRA |= lamp->mask; }
int main(void) {
  for (Lamp *lamp = lamps; lamp < lamps + 3; lamp++) set_up(lamp);
  while (1) for (int i = 0; i < 3; i++) { OUTA ^= lamps[i].mask; pause(10); }
}
