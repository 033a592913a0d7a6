#include <stdio.h>
#include <string.h>
#include <ctype.h>
#include <stdlib.h>
char text[] = "Hello \xe9\xff!";
char key = 'Z';
int count[256];
char up(char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; }
int hash(const char *s) { int h = 5381; while (*s) h = h * 33 + *s++; return h; }
int kind(char c) { switch (c) { case 'a': return 1; case 'A' ... 'Z': return 2; case 0xe9: return 3; case '\xff': return 4; default: return 0; } }
int main()
{
  char c, buffer[20], *p;
  int i, n = 0;
  for (p = text; *p; p++) n += *p;
  printf("%d %d\n", n, hash(text));
  for (i = 0; text[i]; i++) { count[text[i]]++; printf("%d", kind(text[i])); }
  printf("\n%d %d\n", count[0xe9], count['l']);
  for (p = text; *p; p++) if (*p < 128) putchar(up(*p));
  printf("\n");
  c = -1;
  printf("%d %d %d\n", c, c < 0, c == 255);
  c = 250; c += 10; printf("%d\n", c);
  c = '0' + 7; printf("%c %d\n", c, c - '0');
  if (text[6] > 200) printf("high\n");
  printf("%d\n", (int)text[7] - 1);
  strcpy(buffer, "x=");
  strcat(buffer, "12");
  printf("%s %d\n", buffer, (int)strlen(buffer));
  printf("%d\n", strcmp("abc", "abd") < 0);
  sprintf(buffer, "%d/%c/%s/%5d|", 70000, 'q', "z", 42);
  printf("%s\n", buffer);
  printf("%d\n", toupper('x') - isdigit('5') * 0);
  printf("%c%c\n", key, key + 1 - 'Z' + 'B');
  { unsigned char u = 'x'; signed char s = -5; printf("%d %d\n", u - 'w', s * 1000); }
  { char a = 100, b = 100; int m = a * b * 10; char d = a + b; printf("%d %d\n", m, d); }
  { char lines[2][4] = { "ab", "cd" }; printf("%s %c %d\n", lines[1], *lines[0], (int)sizeof lines); }
  for (c = 0; c < 200; c++) n++;
  printf("%d\n", n);
  { int x = 'AB'; printf("%d\n", x); }
  return 0;
}
