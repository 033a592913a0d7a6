int main()
{
  beep_twice(3);
  while (1);
}
