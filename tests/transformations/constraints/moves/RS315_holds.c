#include <string.h>
#include <stdint.h>
/* Sizes of memory that is as big as what it holds, numbers of elements, types of one size. */
int values[4];
int place;

int main(void)
{
  memset(values, 0, sizeof(values));
  for (int i = 0; i < sizeof(values) / sizeof(int); i++) values[i] = i;
  place = 64 + sizeof(int32_t);
}
