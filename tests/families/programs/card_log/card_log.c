/* A log on a memory card, written line by line and read again. */
#include "simpletools.h"

int main() {
  char line[24];
  int number, sum = 0;
  sd_mount(22, 23, 24, 25);
  FILE *fp = fopen("log.txt", "w");
  for (int n = 0; n < 4; n++)
    fprintf(fp, "%d,%d\n", n, n * 20000);
  fclose(fp);
  fp = fopen("log.txt", "r");
  while (fgets(line, 24, fp)) {
    sscan(line, "%d,%d", &number, &sum);
    print("%d %d\n", number, sum);
  }
  fclose(fp);
}
