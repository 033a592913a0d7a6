#include "simpletools.h"
int values[4];
int place;

int main(void)
{
  place = 64 + sizeof(int);  // RS315
  for (int i = 0; i < sizeof(values); i++) pause(i);  // RS315
}
