/* Dates that are put together and written. */
#include <stdio.h>
#include <time.h>

int main() {
  char text[40];
  struct tm when = {0};
  when.tm_year = 120;
  when.tm_mon = 12;
  when.tm_mday = 31;
  when.tm_hour = 25;
  time_t t = mktime(&when);
  printf("%ld %d %d\n", (long)t, when.tm_year, when.tm_yday);
  when = *gmtime(&t);
  strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S %j %a", &when);
  printf("%s\n", text);
  printf("%.0f\n", difftime(t, 1609459200));
  printf("%s", asctime(&when));
}
