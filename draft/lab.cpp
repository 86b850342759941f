// Cars with SOFOF's planner at four arms, conducted: delays, touches.
#include "planners/crossing/agreed.hpp"
#include "planners/crossing/conductor.hpp"
#include "planners/scene/lane_motion.hpp"
#include "planners/scene/scene_interpreter.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/toy_streets.hpp"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
using namespace sofof; using namespace sofof::planners;
static const bool why=getenv("WHY"), service=!getenv("ALONE");
static double env(const char*n,double d){ return getenv(n)?atof(getenv(n)):d; }
struct car { station_id who; route_profile_ptr way; double appears=0, alone_s=0, s=0,v=0,a=0; bool here=false, gone=false; double done=0; world::trajectory plan; std::unique_ptr<spatial_planner> planner; std::unique_ptr<scene_interpreter> scene; driving_scene scene_out; world::trajectory drive; double line=0, clear=0; bool claims=false, near_line=false; int late=0; std::unique_ptr<crossing_member> member; crossing_view view; crossing_claim provider_heard; world::trajectory provider_drive; bool provider_knows=false; int phase=0; long binds=0, bind_late=0; };
int main(int argc,char**argv){
  int seeds=argc>1?atoi(argv[1]):1; double every=argc>2?atof(argv[2]):4; int each=env("EACH",3);
  auto map=toy::cross_roads(!getenv("RANKS")); world::vehicle_params body; comfort_limits style;
  auto lanes=std::make_shared<const lane_network>(map);
  std::vector<route_profile_ptr> ways;
  for(size_t in=1;in<=4;++in)for(size_t out=1;out<=4;++out) if(in!=out) ways.push_back(std::make_shared<const route_profile>(toy::make_route(map,{in,0,out}),style));
  auto box=[&](const world::trajectory_point&p){ const point h{std::cos(p.heading_rad),std::sin(p.heading_rad)}; return oriented_box{p.at+(body.front_m-body.rear_m)/2*h,p.heading_rad,body.front_m+body.rear_m,body.width_m}; };
  auto bodies=[&](const world::trajectory&t){ claimed_drive d{t.start,std::chrono::milliseconds{200},{}}; for(auto at=t.start;at<=t.end();at+=d.step) d.bodies.push_back(box(t.at(at))); return d; };
  // alone
  std::map<int,double> alone;
  std::vector<double> delays; int touch=0,stuck=0; long hard=0,emerg=0,late=0,noplan=0; double cpu=0,cpumax=0; long plans=0; int kept=0;
  for(int seed=1;seed<=seeds;++seed){
    test::dice dice{(uint64_t)seed}; std::vector<int> order(12); for(int i=0;i<12;++i)order[i]=i; for(int i=11;i>0;--i) std::swap(order[i],order[(int)dice.between(0,i+1)]);
    std::vector<car> cars; unsigned id=101;
    auto begin=[&](car&c){ c.planner=std::make_unique<spatial_planner>(c.way,style,spatial_params{}); c.scene=std::make_unique<scene_interpreter>(lanes,std::shared_ptr<const world::route>(c.way,&c.way->line.way()),scene_params{.judges_crossings=true}); };
    auto step=[&](car&c,time_point now,std::vector<track>&tr,std::vector<told_drive>&told){
      planning_input in; in.at=now; in.s_m=c.s; in.speed_mps=c.v; in.accel_mps2=c.a;
      if(!c.plan.empty()){ auto p=c.plan.at(now); auto f=seen_from(c.way->line.way(),p); in.s_m=p.s_m; in.d_m=f.d_m; in.heading_error_rad=f.heading_error_rad; in.curvature_1pm=p.curvature_1pm; in.speed_mps=p.speed_mps; in.accel_mps2=p.accel_mps2; }
      in.others=c.scene_out; in.others.stop_at_m.reset(); in.others.agreed.reset();
      if(c.member){ c.member->look(now,c.view); agreeing_car ac{in.s_m,in.speed_mps,body.front_m}; in.others.agreed=agreed(c.view,now,ac); in.others.stop_at_m=waiting_line_m(c.view,ac); if(!in.others.agreed&&c.near_line){} }
      auto a=in.others.agreed; auto st=in.others.stop_at_m;
      c.scene->describe(now,{c.who,in.s_m,in.d_m,in.speed_mps},tr,in.others,told);
      in.others.agreed=a; in.others.stop_at_m=st;
      world::trajectory out; auto r=c.planner->plan(now,in,c.plan.empty()?nullptr:&c.plan,out); c.plan=out; c.scene_out=in.others;
      if(r.emergency){++emerg; if(why) std::printf("EMERG t %.2f %u s %.1f v %.2f a %.2f line %.1f drive %d claims %d lead %.1f told %zu cross %zu\n",to_seconds(now-time_point{}),c.who.value(),c.s,c.v,c.a,c.line-c.s,!c.drive.empty(),c.claims,in.others.lead?in.others.lead->rear_s_m-c.s-body.front_m:-1,in.others.lead_told.size(),in.others.crossings.size()); }
      if(r.is_late){ ++late; ++c.late; if(why&&c.late==1) std::printf("LATE t %.2f %u s %.1f v %.2f a %.2f line %.1f claims %d first %.1f@%.2f lead %.1f told %zu cross %zu\n",to_seconds(now-time_point{}),c.who.value(),c.s,c.v,c.a,c.line-c.s,c.claims,a&&!a->axle.empty()?a->axle[0].s_m-c.s:-1,a&&!a->axle.empty()?a->axle[0].t_s:-1,in.others.lead?in.others.lead->rear_s_m-c.s-body.front_m:-1,in.others.lead_told.size(),in.others.crossings.size()); } else c.late=0;
      auto p=c.plan.at(now+std::chrono::milliseconds{50}); c.s=p.s_m; c.v=p.speed_mps; c.a=p.accel_mps2; if(c.a<-3)++hard; };
    int R=env("R",6); for(int r=0;r<R;++r){ double from=dice.between(10,40), first=dice.between(0,2); for(int k=0;k<each;++k){ car c; c.who=station_id{id++}; c.way=ways[order[r]]; c.s=from; c.appears=first+k*every; begin(c);
      { car x; x.who=c.who; x.way=c.way; x.s=from; begin(x); std::vector<track> none; std::vector<told_drive> nt; double t=0; auto L=c.way->line.way().length_m()-15; while(x.s<L&&t<120){ step(x,time_point{from_seconds(t)},none,nt); t+=.05;} c.alone_s=t; }
      cars.push_back(std::move(c)); } }
    emerg=hard=late=0;
    conducting how; crossing_ways cw{lanes,{{0,0},80},body}; conductor boss{cw,how}; std::vector<crossing_advice> advice;
    struct letter{car*to; time_point at; crossing_claim what; claimed_drive plan; point from;}; std::vector<letter> letters;
    int n=0; double T=env("T",240);
    for(double t=0;t<T;t+=.05,++n){ time_point now{from_seconds(t)};
      for(auto&c:cars) if(!c.here&&!c.gone&&t>=c.appears){ bool free=true; for(auto&o:cars) if(o.here&&!o.gone&&o.way->line.way().at_lane(o.s).lane==c.way->line.way().at_lane(c.s).lane&&(std::abs(o.s-c.s)<9||(o.s<c.s&&c.s-o.s<9+o.v*1.5+o.v*o.v/3))) free=false; if(free) c.here=true; }
      static const double loss=env("LOSS",0.01);
      if(service&&n%10==0){ std::vector<approaching_car> all; for(auto&c:cars) if(c.here&&!c.gone){ approaching_car x{c.who,c.way,c.s,c.v,c.a,true,{}}; if(c.provider_knows&&!c.provider_drive.empty()&&now<=c.provider_drive.end()){ x.drive=c.provider_drive; x.has_claimed=c.provider_heard.drive.has_value(); } all.push_back(x);} 
        clock_t b=clock(); boss.plan(now,all,advice); double ms=1e3*(clock()-b)/CLOCKS_PER_SEC; cpu+=ms; cpumax=std::max(cpumax,ms); ++plans;
        for(auto&c:cars){ bool told=false; for(auto&a:advice) if(c.who==a.who){ c.drive=a.drive; told=true; if(!a.drive.empty()&&!a.drive.is_sound()){ auto&P=a.drive.points; std::printf("UNSOUND t %.2f %u n %zu step %.4f v %.2f..%.2f\n",t,c.who.value(),P.size(),P.size()>1?P[1].t_s:-1,P.front().speed_mps,P.back().speed_mps); for(auto&p:P) if(!(p.speed_mps<60)) std::printf(" at %.2f v %.2f",p.s_m,p.speed_mps); c.drive={}; } } if(!told&&c.provider_heard.drive) c.drive=c.provider_drive; } }
      std::vector<track> tr; for(auto&c:cars) if(c.here&&!c.gone){ auto p=c.plan.empty()?world::trajectory_point{}:c.plan.at(now); if(c.plan.empty()){ auto q=c.way->line.way().path().at(c.s); p.at=q.at; p.heading_rad=q.heading_rad; }
        auto bx=box(p); track k; k.id=c.who.value(); k.station=c.who; k.at=k.seen=now; k.moved=now; k.motion.mean.col(0)<<bx.centre.x_m,bx.centre.y_m; k.motion.mean.col(1)<<c.v*std::cos(p.heading_rad),c.v*std::sin(p.heading_rad); k.motion.covariance=Eigen::Matrix2d::Identity()*1e-4; k.heading_rad=p.heading_rad; k.accel_mps2=c.a; k.length_m=bx.length_m; k.width_m=bx.width_m; tr.push_back(k);
        if(!service) continue;
        if(!c.member){ c.member=std::make_unique<crossing_member>(c.who,body); c.phase=(int)dice.between(0,2); }
        auto pl=cw.find(c.way,c.s,150); if(pl){ auto&w=cw[pl->way]; double half=(body.front_m+body.rear_m)/2; c.line=w.enters_m+half+pl->lap_m; c.clear=w.leaves_m-half+pl->lap_m; }
        if(!c.drive.empty()&&now<=c.drive.end()&&dice.between(0,1)>=loss) c.member->advise(now,c.drive);
        bool was=c.member->state()!=claim_book::state::free; auto was_st=c.member->state();
        c.member->move(now,{c.s,c.v,pl?c.line:c.s-100,c.clear,p.at,c.plan.empty()?nullptr:&c.plan});
        if(why&&was&&c.member->state()==claim_book::state::free) std::printf("GAVE UP t %.2f %u s %.1f v %.2f line %.1f was %d\n",t,c.who.value(),c.s,c.v,c.line-body.front_m-c.s,(int)was_st);
        c.claims=c.member->state()!=claim_book::state::free;
        if(n%2==c.phase){ auto told=c.member->tell(now); auto* d=c.member->drive(); auto plan=d?bodies(*d):c.plan.empty()?claimed_drive{}:bodies(c.plan);
          if(dice.between(0,1)>=loss){ c.provider_heard=told; c.provider_drive=d?*d:world::trajectory{}; c.provider_knows=true; }
          for(auto&o:cars) if(&o!=&c&&o.here&&!o.gone&&o.member&&dice.between(0,1)>=loss) letters.push_back({&o,now+from_seconds(dice.between(.002,.04)),told,plan,p.at}); }
      }
      std::erase_if(letters,[&](auto&l){ if(l.at>now) return false; if(l.to->member&&l.to->here) l.to->member->hear(now,l.what,l.plan,l.from); return true; });
      if(why&&n%40==0) for(auto&c:cars) if(c.here&&!c.gone){ double en=-1; for(auto&p:c.drive.points) if(p.s_m>=c.line-body.front_m){ en=to_seconds(c.drive.start-now)+p.t_s; break; } std::printf("CAR t %.1f %u s %.1f v %.2f a %.2f line %.1f enters in %.1f state %d\n",t,c.who.value(),c.s,c.v,c.a,c.line-body.front_m-c.s,en,c.member?(int)c.member->state():-1); }
      for(auto&c:cars) if(c.here&&!c.gone){ step(c,now,tr,c.view.told); if(c.s>c.way->line.way().length_m()-15){ c.gone=true; c.done=t+.05; } }
      for(size_t i=0;i<cars.size();++i)for(size_t k=0;k<i;++k){auto&a=cars[i];auto&b=cars[k]; if(!a.here||!b.here||a.gone||b.gone||a.plan.empty()||b.plan.empty())continue; if(overlap(box(a.plan.at(now)),box(b.plan.at(now)))){ if(why&&touch<50)std::printf("TOUCH t %.2f %u s %.1f v %.2f claims %d, %u s %.1f v %.2f claims %d\n",t,a.who.value(),a.s,a.v,a.claims,b.who.value(),b.s,b.v,b.claims); ++touch;}}
    }
    double sum=0; for(auto&c:cars){ if(!c.gone){++stuck;} else {delays.push_back(c.done-c.appears-c.alone_s); sum+=delays.back();} }
    std::printf("seed %d mean %.2f emerg %ld hard %ld late %ld kept %d\n",seed,sum/cars.size(),emerg,hard,late,0);
  }
  std::sort(delays.begin(),delays.end()); double m=0; for(auto d:delays)m+=d; m/=delays.size();
  if(!delays.empty()) std::printf("cars %zu mean %.2f p95 %.1f max %.1f touch %d stuck %d cpu mean %.2f max %.1f ms kept %d\n",delays.size(),m,delays[size_t(.95*delays.size())],delays.back(),touch,stuck,cpu/std::max(1L,plans),cpumax,kept);
}
