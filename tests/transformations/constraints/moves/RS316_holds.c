#include "simpletools.h"
#include <stdint.h>
/* Numbers and formats agree on the target; texts, characters and real numbers are none; nothing is known of HOME. */
int32_t total;
int small;
char name[8];

int main(void)
{
  print("%d cm\n", (int)ping_cm(8));
  print("%ld %d %5.2f %s %%\n", total, small, 1.5, name);
  print("%c%*d\n", HOME, 5, small);
  scan("%d %s", &small, name);
}
