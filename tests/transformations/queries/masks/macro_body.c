// ports 6 13
#include "simpletools.h"
#define ON(n) (OUTA |= 1 << (n))
#define IS_ON(n) (INA >> (n) & 1)
int main(void) {
  DIRA |= 1 << 6;
  if (IS_ON(13)) ON(6);
}
