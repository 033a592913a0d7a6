enum colour { RED, GREEN };
void use(void *context);
enum colour shown = RED;

enum colour none(void)
{
  return -1;  // RS336
}

int main(void)
{
  use((void *)70000);  // RS336
  use((void *)40000);  // RS336
  shown = -1;  // RS336
  if (shown == none()) use(0);
}
