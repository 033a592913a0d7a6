#include "simpletools.h"
#include "lamp.h"

int main()
{
  while(1)
  {
    flash(3);
  }
}
