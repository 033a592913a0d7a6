#include "simpletools.h"
long now;

int main(void)
{
  now = time(0);  // RS324: time(0)
}
