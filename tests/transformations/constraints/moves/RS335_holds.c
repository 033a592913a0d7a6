#include "simpletools.h"
#define SHOWN(pin, ...) print("%d %d\n", pin, __VA_ARGS__); set_output(pin, __VA_ARGS__)
#define FIVE(name) name(5)
int numbers;
void thigh(int n) { numbers += n; }

int main(void)
{
  SHOWN(11, 1);
  FIVE(thigh);
  FIVE(high);
}
