/* Bytes in a file, from a place in it on. */
#include "simpletools.h"

int main() {
  int v = 70000, w = 0;
  sd_mount(22, 23, 24, 25);
  FILE *fp = fopen("data.bin", "w");
  fputs("head", fp);
  fwrite(&v, 1, sizeof(int), fp);
  fputc('!', fp);
  print("%d\n", (int)ftell(fp));
  fclose(fp);
  fp = fopen("data.bin", "r");
  fseek(fp, 4, SEEK_SET);
  fread(&w, 1, sizeof(int), fp);
  print("%d %c", w, fgetc(fp));
  rewind(fp);
  print("%c\n", fgetc(fp));
  fclose(fp);
  print("%d\n", fopen("none.txt", "r") == 0);
}
