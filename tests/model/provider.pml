/* == SP: provider.cpp, provider_requests.cpp; provider_manager.cpp, service_cycle.cpp */
inline sp_end(p, tells) {
  if :: runs[p] != 0 ->
        assert(!(closed_there & BIT(runs[p])));
        closed_there = closed_there | BIT(runs[p]);
        if :: tells -> ends_down = ends_down | BIT(runs[p]) :: else fi;
        runs[p] = 0; fed[p] = 0; called[p] = 0; mute[p] = 0; was_inside[p] = 0;
        told[p] = (DIGESTS -> TOLD : 0)
     :: else fi
}
#define LATEST(p) (boot[p] * MOST + counter[p])
#define HAS_OPEN(p) (open_request[boot[p]] != 0)
/* What a digest may overtake, or be overtaken by. */
#define UNDER_WAY(p) ((requests[p] | refusals | acceptances | ends_up | ends_down) != 0)
/* Whether input of its session is, or comes, on the way. */
#define IS_FED(p) (len(to_rm) != 0 || (sources & BIT(runs[p])) || ((inputs | calls | acceptances) & BIT(runs[p])))
proctype SP(byte p, v) {
  byte r, n; short w;
end: do
  :: atomic { alive[p] && !heard[p] -> heard[p] = 1; seen_request[p] = 0 } /* a CAM */
#if OFFERS
  :: atomic { left > 0 && alive[p] && heard[p] && runs[p] == 0 && !(offers & BIT(boot[p])) -> FAULT; offers = offers | BIT(boot[p]) }
#endif
  /* an offer that SR would act on */
  :: atomic { alive[p] && inside[p] && heard[p] && MAY_OFFLOAD && GETS_INPUTS &&
              runs[p] == 0 && !(offers & BIT(boot[p])) && at[boot[p]] == NONE &&
              !HAS_OPEN(p) && !IS_MOVING && !((cool | doubted) & BIT(boot[p])) && !(POLICY == ALWAYS && IS_REMOTE) &&
              (refusals | requests[0] | requests[1] | ends_up | ends_down) == 0 && len(to_rm) == 0 && len(to_sr) == 0 && !exhausted &&
              (POLICY != HANDOVER || !IS_REMOTE || preferred == p) && (POLICY != ANYTHING || !(offered & BIT(boot[p])) || left > 0) ->
#if POLICY == ANYTHING
     if :: (offered & BIT(boot[p])) -> FAULT :: else fi;
#endif
     offers = offers | BIT(boot[p]) }
  :: atomic { requests[p] != 0 -> pick(requests[p], n); arrive(requests[p], n);
     if
     :: !alive[p]
     :: (alive[p] && (asked[n] != boot[p] || !heard[p])) -> refusals = refusals | BIT(n)
     :: (alive[p] && asked[n] == boot[p] && heard[p] && (n > seen_request[p] || MUTANT == 6)) ->
        seen_request[p] = n;
        if :: MUTANT != 5 -> sp_end(p, 1) :: else fi;
        if :: ((inside[p] || OFFERS) && counter[p] < MOST) -> /* outside it is the policy's business */
              counter[p]++; r = LATEST(p); answers[r] = n; runs[p] = r; was_inside[p] = inside[p];
              started = started | BIT(r); acceptances = acceptances | BIT(r)
           :: !inside[p] -> refusals = refusals | BIT(n)
           :: (REFUSES && left > 0) -> FAULT; refusals = refusals | BIT(n)
           :: counter[p] >= MOST -> exhausted = 1; refusals = refusals | BIT(n)
        fi
     :: else
     fi; n = 0; r = 0 }
  :: atomic { (ends_up & ALL_OF(p)) != 0 -> w = ends_up & ALL_OF(p); pick(w, r); w = 0; arrive(ends_up, r);
     if :: (alive[p] && runs[p] == r) -> sp_end(p, 0) :: else fi; r = 0 }
  /* RM feeds it, as far as that changes anything */
  :: atomic { runs[p] != 0 && alive[p] && (sources & BIT(runs[p])) && !((inputs | calls) & BIT(runs[p])) && !((in_use & BIT(runs[p])) && STANDS(runs[p])) &&
       ((!STANDS(runs[p]) && (!fed[p] || called[p])) || (STANDS(runs[p]) && !(results & BIT(runs[p])) && len(to_rm) == 0)) -> r = runs[p]; feed(r); r = 0 }
  :: atomic { (inputs & ALL_OF(p)) != 0 -> w = inputs & ALL_OF(p); pick(w, r); w = 0; arrive(inputs, r);
     if :: (alive[p] && runs[p] == r) -> fed[p] = 1; called[p] = 0 :: else fi; r = 0 }
  :: atomic { (calls & ALL_OF(p)) != 0 -> w = calls & ALL_OF(p); pick(w, r); w = 0; arrive(calls, r);
     if :: (alive[p] && runs[p] == r) -> fed[p] = 1; called[p] = 1;
           results = (mute[p] -> results : results | BIT(r));
           late_results = (mute[p] == OLD -> late_results | BIT(r) : late_results)
        :: else fi; r = 0 }
  /* a result in every period, unless it stands by; where it changes anything */
  :: atomic { alive[p] && runs[p] != 0 && fed[p] && !called[p] && !mute[p] && GETS_INPUTS && !(results & BIT(runs[p])) && len(to_rm) < 3 &&
      ((!HAS(runs[p]) && (known & BIT(BOOT(runs[p]))) && !(ends_up & BIT(runs[p])) && !(acceptances & BIT(runs[p]))) ||
        (HAS(runs[p]) && (sources & BIT(runs[p])) && !(in_use & BIT(runs[p])) && !(to_rm??[RESULT, eval(runs[p])])) ||
        (HAS(runs[p]) && (in_use & BIT(runs[p])) && STANDS(runs[p]) && !(calls & BIT(runs[p])) && !(to_rm??[RESULT, eval(runs[p])]))) ->
     results = results | BIT(runs[p]) }
  :: atomic { left > 0 && alive[p] && runs[p] != 0 && fed[p] && !called[p] -> FAULT; late_results = late_results | BIT(runs[p]) }
#if STALE
  :: atomic { alive[p] && runs[p] != 0 && fed[p] && !called[p] && mute[p] == OLD && !(late_results & BIT(runs[p])) && len(to_rm) < 3 &&
      ((!HAS(runs[p]) && (known & BIT(BOOT(runs[p]))) && !((ends_up | acceptances) & BIT(runs[p]))) ||
        (HAS(runs[p]) && in_use == BIT(runs[p]) && armed != 0 && !(to_rm??[LATE, eval(runs[p])]) && len(to_wd) == 0)) ->
     late_results = late_results | BIT(runs[p]) }
#endif
#if LIES
  :: atomic { left > 0 && alive[p] && runs[p] != 0 && fed[p] -> FAULT; bad_results = bad_results | BIT(runs[p]) }
#endif
  /* never fed: protocol::start_timeout */
  :: atomic { alive[p] && runs[p] != 0 && !fed[p] && MUTANT != 2 && (left > 0 || !IS_FED(p)) ->
     if :: IS_FED(p) -> FAULT :: else fi; sp_end(p, 1) }
#if DIGESTS
  /* a digest of what runs, and after the end of the last session some that name
     nothing: where they change anything, or what they tell of is under way */
  :: atomic { MUTANT != 14 && alive[p] && runs[p] != 0 && !(digests & BIT(runs[p])) &&
       ((DIGESTS == ANY_MOMENT && UNDER_WAY(p)) ||
        ((known & BIT(boot[p])) && !HAS(runs[p]) && !HAS_OPEN(p) && !((ends_up | acceptances) & BIT(runs[p]))) ||
        (at[boot[p]] >= STARTING && session[boot[p]] < runs[p] && len(to_rm) == 0)) ->
     digests = digests | BIT(runs[p]) }
  :: atomic { alive[p] && runs[p] == 0 && told[p] != 0 && !(empty_digests & BIT(LATEST(p))) &&
       ((DIGESTS == ANY_MOMENT && UNDER_WAY(p)) ||
        (at[boot[p]] >= STARTING && session[boot[p]] <= LATEST(p) && len(to_rm) == 0 && len(to_sr) == 0 &&
         !(acceptances & BIT(LATEST(p))) && !(ends_down & BIT(session[boot[p]])))) ->
     empty_digests = empty_digests | BIT(LATEST(p)); told[p]-- }
#endif
#if REFUSES
  :: atomic { left > 0 && alive[p] && runs[p] != 0 -> FAULT; sp_end(p, 1) } /* revoked */
#endif
#if OFFERS
  :: atomic { alive[p] && heard[p] && inside[p] && runs[p] != 0 && !was_inside[p] -> was_inside[p] = 1 } /* a CAM */
#endif
  :: atomic { alive[p] && heard[p] && !inside[p] && runs[p] != 0 && was_inside[p] -> sp_end(p, 1) } /* left_area */
  :: atomic { left > 0 && alive[p] && heard[p] -> FAULT;
     if :: MUTANT != 21 -> sp_end(p, 1) :: else -> runs[p] = 0; fed[p] = 0 fi; heard[p] = 0; told[p] = 0 } /* cam_timeout: the record goes, and its digests */
  od
}

