enum colour { RED, GREEN, FAR = 40000 };
enum sign { BELOW = -1, ABOVE = 1 };
void use(void *context);
enum colour shown = RED;
enum sign which = -1;
int number;

int main(void)
{
  use((void *)1234);
  use((void *)&number);
  use((void *)-1);
  shown = 40000;
  shown = GREEN;
  which = -1;
  if (shown == RED && which == BELOW) use(0);
}
