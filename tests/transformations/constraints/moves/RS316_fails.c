#include "simpletools.h"
#include <stdint.h>
int32_t total;
int small;

int main(void)
{
  print("%d cm\n", ping_cm(8));  // RS316: print("%d cm\n", ping_cm(8))
  print("%d %ld\n", total, small);  // RS316: print("%d %ld\n", total, small)
  scan("%d", &total);  // RS316: scan("%d", &total)
}
