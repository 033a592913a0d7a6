#include "simpletools.h"
#include "state.h"

int main()
{
  while (1) {
    counter++;
    tick();
  }
}
