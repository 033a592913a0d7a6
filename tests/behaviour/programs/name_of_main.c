#include <stdio.h>
int other(void) { printf("%s ", __func__); return 70000; }
int main(void) {
  printf("%s %s %d\n", __func__, __FUNCTION__, (int)sizeof __func__);
  while (1) printf("%d %s\n", other(), __func__);
}
