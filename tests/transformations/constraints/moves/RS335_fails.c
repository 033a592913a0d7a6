#include "simpletools.h"
#define SHOWN(...) print("%d %d\n", __VA_ARGS__); set_output(__VA_ARGS__)
#define FIVE(name) name##high(5)
int numbers;
void thigh(int n) { numbers += n; }

int main(void)
{
  SHOWN(11, 1);  // RS335: SHOWN(11, 1)
  FIVE(t);
  FIVE();  // RS335: FIVE()
}
