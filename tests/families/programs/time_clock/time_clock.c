/* Times of the C library: seconds, ticks and dates. */
#include <stdio.h>
#include <time.h>
#include <unistd.h>
#include <sys/time.h>
#include "propeller.h"

int main() {
  struct timeval now;
  clock_t begun = clock();
  usleep(30000);
  printf("%d\n", (int)((clock() - begun) / (CLOCKS_PER_SEC / 1000)));
  now.tv_sec = 951782399;
  now.tv_usec = 500000;
  settimeofday(&now, 0);
  sleep(1);
  gettimeofday(&now, 0);
  printf("%ld %d\n", (long)now.tv_sec, (int)(now.tv_usec / 10000));
  time_t t = time(0);
  struct tm *date = gmtime(&t);
  printf("%d-%d-%d %d:%d:%d %d\n", date->tm_year + 1900, date->tm_mon + 1, date->tm_mday, date->tm_hour, date->tm_min, date->tm_sec, date->tm_wday);
}
