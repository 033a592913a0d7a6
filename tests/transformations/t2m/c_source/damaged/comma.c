#include "simpletools.h"

int main()
{
  set_output(1 1);
  pulse_out(5, 6);
}
