#include "simpletools.h"
#include "signal_mast.h"

int main()
{
  print("%d %d", mast_show(1, 1), mast_show(2, 1));
}
