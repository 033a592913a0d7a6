// ports 3 5
#include "simpletools.h"
typedef struct { int bit; } Lamp;
typedef struct { int bit; } Step;
Lamp lamps[] = {{3}, {5}};
Step steps[] = {{11}, {12}};
int main(void) {
  int sum = 0;
  while (1) for (int i = 0; i < 2; i++) { OUTA ^= 1 << lamps[i].bit; sum += steps[i].bit; pause(sum); }
}
