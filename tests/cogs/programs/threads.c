/* POSIX threads: two add under a mutex, main joins them. */
#include <pthread.h>
#include "simpletools.h"

pthread_mutex_t guard = PTHREAD_MUTEX_INITIALIZER;
volatile int total;

void *add(void *arg)
{
  int i;
  for (i = 0; i < 10; i++)
  {
    pthread_mutex_lock(&guard);
    int was = total;
    pause(1);
    total = was + *(int *)arg;
    pthread_mutex_unlock(&guard);
  }
  return arg;
}

int main(void)
{
  pthread_t one, two;
  int a = 3, b = 4;
  void *result;
  pthread_create(&one, NULL, add, &a);
  pthread_create(&two, NULL, add, &b);
  pthread_join(one, NULL);
  pthread_join(two, &result);
  print("%d %d\n", total, *(int *)result);
  return 0;
}
