/* == faults =========================================================================== */
inline lose(set, x) { pick(set, x); set = set & ~BIT(x); FAULT; x = 0 }
#if CRASH
inline die(x) { /* the first provider, for one vehicle */
  heard[0] = 0; died = died | BIT(runs[0]); runs[0] = 0; fed[0] = 0; called[0] = 0; mute[0] = 0; told[0] = 0; was_inside[0] = 0;
  x = 1; do :: x <= SESSIONS -> if :: PROVIDER(BOOT(x)) == 0 ->
     acceptances = acceptances & ~BIT(x); results = results & ~BIT(x); late_results = late_results & ~BIT(x);
     bad_results = bad_results & ~BIT(x); inputs = inputs & ~BIT(x); calls = calls & ~BIT(x);
     digests = digests & ~BIT(x); empty_digests = empty_digests & ~BIT(x) :: else fi; x++ :: else -> break od; x = 0;
  offers = offers & ~1;
#if CRASH == 2
  if :: session[0] != 0 -> ends_down = ends_down | BIT(session[0]) :: else fi
#else
  deaths = deaths | 1
#endif
}
#endif
proctype faults(byte v) {
  byte x;
end: do
  :: atomic { left > 0 && offers != 0 -> lose(offers, x) }
  :: atomic { left > 0 && requests[0] != 0 -> lose(requests[0], x) }
  :: atomic { left > 0 && requests[1] != 0 -> lose(requests[1], x) }
  :: atomic { left > 0 && refusals != 0 -> lose(refusals, x) }
  :: atomic { left > 0 && acceptances != 0 -> lose(acceptances, x) }
  :: atomic { left > 0 && inputs != 0 -> lose(inputs, x) }
  :: atomic { left > 0 && calls != 0 -> lose(calls, x) }
  :: atomic { left > 0 && results != 0 -> lose(results, x) }
  :: atomic { left > 0 && ends_up != 0 -> lose(ends_up, x) }
  :: atomic { left > 0 && ends_down != 0 -> lose(ends_down, x) }
  :: atomic { left > 0 && digests != 0 -> lose(digests, x) }
  :: atomic { left > 0 && empty_digests != 0 -> lose(empty_digests, x) }
#if SILENT
  :: atomic { left > 0 && alive[0] && runs[0] != 0 && !mute[0] -> FAULT; mute[0] = 1 }
#endif
#if STALE
  :: atomic { left > 0 && alive[0] && runs[0] != 0 && !mute[0] -> FAULT; mute[0] = OLD }
#endif
#if OUTAGE
  :: atomic { left > 0 && (offers | requests[0] | requests[1] | refusals | acceptances | inputs | calls | results | ends_up | ends_down | digests | empty_digests) != 0 -> FAULT;
     offers = 0; requests[0] = 0; requests[1] = 0; refusals = 0; acceptances = 0; inputs = 0; calls = 0; results = 0; late_results = 0;
     bad_results = 0; ends_up = 0; ends_down = 0; digests = 0; empty_digests = 0 }
#endif
#if POLICY == HANDOVER
  :: atomic { left > 0 -> FAULT; preferred = 1 - preferred }
#endif
#if LEAVES
#if CHAIN
  :: atomic { left > 0 && v == 0 -> FAULT; inside[0] = 1 - inside[0]; OTHER.inside_[0] = inside[0] }
#else
  :: atomic { left > 0 -> FAULT; inside[0] = 1 - inside[0] }
#endif
#endif
#if NEIGHBOUR
  :: atomic { left > 0 && alive[0] && counter[0] < MOST - 1 -> FAULT; counter[0]++ }
#endif
#if CRASH
#if CHAIN
  :: atomic { left > 0 && v == 0 && alive[0] && boot[0] == 0 -> FAULT; alive[0] = 0;
     die(x); v = 1; die(x); v = 0 }
  :: atomic { v == 0 && !alive[0] && (deaths | OTHER.deaths_) == 0 -> alive[0] = 1; boot[0] = 2; counter[0] = 0;
     seen_request[0] = 0; OTHER.seen_request_[0] = 0 }
#else
  :: atomic { left > 0 && alive[0] && boot[0] == 0 -> FAULT; alive[0] = 0; die(x) }
  :: atomic { !alive[0] && deaths == 0 -> alive[0] = 1; boot[0] = 2; counter[0] = 0; seen_request[0] = 0 }
#endif
#endif
  od
}

