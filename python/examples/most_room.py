"""Offloads to the provider that has most room."""
from sofof import Policy, run_at, stay

class MostRoom(Policy):
    version = "1"

    def decide(self, ask):
        if not ask.providers:
            return stay("nobody is there")
        best = min(ask.providers, key=lambda x: (x.utilisation, x.id))
        return run_at(best) if best.utilisation < 0.9 else stay("all are full")

MostRoom().run()
