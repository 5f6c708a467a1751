//! Behaviors of any behaviors and of lists of any capacity: `behavior tour(stops: [Stop; n], at_each: behavior(Stop))`. For each behavior and each
//! capacity that one is called with there is a behavior of its own, in which `at_each` and `n` are those: which they are is known before anything
//! runs.

use super::args::Given;
use super::capacities::{Capacities, Declared, INSTANCES_MAX, NOMINAL, capacity};
use super::expr::article;
use super::names::Found;
use super::{Checker, Def, ParamInfo, Scope, Setting, Signature};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Action, ActivityId, VarKind};
use crate::source::Span;
use crate::syntax::tree::{self, ActivityKind, TyKind};
use crate::types::Type;
use std::collections::BTreeMap;

/// What is known of a behavior that is given.
#[derive(Clone, Debug)]
pub(super) struct BehaviorType {
    /// The types of what it is called with.
    takes: Vec<Type>,
    /// That of the result that is read.
    result: Option<Type>,
}

/// A parameter that is a behavior, and which one it is.
#[derive(Clone)]
pub(super) struct GivenBehavior {
    name: String,
    span: Span,
    id: ActivityId,
    result: Option<Type>,
}

impl GivenBehavior {
    pub fn id(&self) -> ActivityId {
        self.id
    }

    /// The result that is read of it, whatever it has.
    pub fn result(&self) -> Option<&Type> {
        self.result.as_ref()
    }

    pub fn span(&self) -> Span {
        self.span
    }
}

/// A behavior or a strategy of which there are several by what it is given.
#[derive(Clone)]
struct ActivityTemplate<'t> {
    module: usize,
    activity: &'t tree::Activity,
    /// What it calls the capacities of lists.
    capacities: Vec<String>,
}

/// What is made of such a one.
struct Made {
    id: ActivityId,
    of: ActivityId,
    params: Vec<ParamInfo>,
    behaviors: Vec<ActivityId>,
    capacities: Vec<u32>,
    /// Where it was called first.
    called: Span,
}

/// Behaviors of which there are several, and what is made of them.
#[derive(Default)]
pub(super) struct ActivityTemplates<'t> {
    of: BTreeMap<ActivityId, ActivityTemplate<'t>>,
    made: BTreeMap<(ActivityId, Vec<ActivityId>, Vec<u32>), ActivityId>,
    /// Of what was made and of what stands in for what is given: it has no declaration of its own.
    signatures: BTreeMap<ActivityId, Signature>,
    /// What is made and is still to be checked.
    ahead: Vec<Made>,
}

/// Whether a parameter is a behavior.
pub(super) fn is_behavior(param: &tree::Param) -> bool {
    matches!(param.ty.kind, TyKind::Behavior(..))
}

impl<'t> Checker<'t> {
    pub(super) fn activity_signature(&self, id: ActivityId) -> &Signature {
        self.activity_templates.signatures.get(&id).unwrap_or_else(|| &self.activity_signatures[id])
    }

    /// The parameters of an activity, and of which there are several by them.
    pub(super) fn activity_params(&mut self, id: ActivityId, m: usize, a: &'t tree::Activity) -> Vec<ParamInfo> {
        let is_one = matches!(a.kind, ActivityKind::Behavior | ActivityKind::Strategy { .. });
        let first = a.params.iter().find(|param| is_behavior(param));
        if let Some(first) = first.filter(|_| !is_one) {
            let message = "a behavior is given to behaviors and strategies only";
            let finding = Diagnostic::error(Code::TypesBehavior, first.ty.span, message);
            self.report(finding.help("call it here: which one it is is known"));
        }
        let capacities = if is_one { self.capacity_names(m, &a.params) } else { Vec::new() };
        if is_one && (first.is_some() || !capacities.is_empty()) {
            let capacities = capacities.clone();
            self.activity_templates.of.insert(id, ActivityTemplate { module: m, activity: a, capacities });
        }
        self.params_for(m, a, nominal(&capacities))
    }

    /// The parameters of an activity for some capacities.
    fn params_for(&mut self, m: usize, a: &'t tree::Activity, capacities: Capacities) -> Vec<ParamInfo> {
        let outer = std::mem::replace(&mut self.scope.capacities, capacities);
        let params = self.params(m, &a.params, Some(&a.name.node));
        self.scope.capacities = outer;
        params
    }

    /// What is known of a parameter that is a behavior.
    pub(super) fn behavior_param(&mut self, m: usize, param: &tree::Param) -> Option<BehaviorType> {
        let TyKind::Behavior(types, result) = &param.ty.kind else { return None };
        for (span, what) in [
            param.ty.optional.then_some((param.ty.span, "a behavior cannot be absent")),
            param.default.as_ref().map(|default| (default.span, "a behavior has no default")),
            param.range.as_ref().map(|range| (range.first.span, "no range can hold a behavior")),
        ]
        .into_iter()
        .flatten()
        {
            self.report(Diagnostic::error(Code::TypesBehavior, span, what).help("leave it out: the call gives one"));
        }
        let takes = types.iter().map(|ty| self.written_type(m, ty)).collect();
        Some(BehaviorType { takes, result: result.as_ref().map(|ty| self.written_type(m, ty)) })
    }

    /// What stands in for behaviors that are given, where a body is checked as it is declared.
    pub(super) fn stand_ins(&mut self, params: &[ParamInfo]) -> Vec<ActivityId> {
        let given: Vec<ParamInfo> = params.iter().filter(|param| param.behavior.is_some()).cloned().collect();
        let stand_in = |param: ParamInfo| {
            let (takes, result) = param.behavior.map(|of| (of.takes, of.result)).unwrap_or_default();
            let params = takes.into_iter().enumerate().map(|(i, ty)| ParamInfo {
                name: format!("argument {}", i + 1),
                ty,
                default: None,
                range: None,
                behavior: None,
                span: param.span,
            });
            let params = params.collect();
            self.made_activity(Signature { name: param.name, span: param.span, params, result })
        };
        given.into_iter().map(stand_in).collect()
    }

    fn made_activity(&mut self, signature: Signature) -> ActivityId {
        let id = self.hir.activities.len();
        self.hir.activities.push(hir::Activity::empty(&signature.name, signature.span));
        self.activity_templates.signatures.insert(id, signature);
        id
    }

    /// Makes a parameter that is a behavior known from here on.
    pub(super) fn declare_behavior(&mut self, name: &tree::Name, result: Option<Type>, id: ActivityId) {
        if self.local(&name.node).is_some() || self.given_behavior(&name.node).is_some() {
            let message = format!("`{}` is the name of something already", name.node);
            self.report(Diagnostic::error(Code::NamesShadowed, name.span, message).help("choose another name"));
        }
        self.names_used.declare(name, VarKind::Param);
        self.scope.behaviors.push(GivenBehavior { name: name.node.clone(), span: name.span, id, result });
    }

    /// The behavior that was given under a name.
    pub(super) fn given_behavior(&self, name: &str) -> Option<&GivenBehavior> {
        self.scope.behaviors.iter().find(|given| given.name == name)
    }

    /// The behavior that was given under a name, which is called or handed on.
    pub(super) fn use_given(&mut self, name: &str, at: Span) -> Option<GivenBehavior> {
        let given = self.given_behavior(name)?.clone();
        self.names_used.read(given.span);
        self.names_used.refer(at, given.span);
        Some(given)
    }

    /// A call of a behavior, of which there may be several by what they are given.
    pub(super) fn call_of_activity(
        &mut self,
        id: ActivityId,
        args: &[tree::Arg],
        span: Span,
    ) -> Option<(Action, Option<Type>)> {
        let signature = self.activity_signature(id).clone();
        let places = (span, Some(signature.span));
        let Some(template) = self.activity_templates.of.get(&id).cloned() else {
            let values = self.arguments(&signature.name, &signature.params, args, span, places.1)?;
            return Some((Action::Call(id, values), signature.result));
        };
        let (written, mut failed) = self.by_parameter(&signature.name, &signature.params, args, true);
        let (mut behaviors, mut given) = (Vec::new(), Vec::new());
        let mut capacities: Vec<u32> = template.capacities.iter().map(|_| 1).collect();
        for ((param, declared), written) in signature.params.iter().zip(&template.activity.params).zip(written) {
            let place =
                capacity(&declared.ty).and_then(|name| template.capacities.iter().position(|known| known == name));
            match (&param.behavior, &param.ty, place, written) {
                (Some(of), _, _, Some(written)) => {
                    let found = self.behavior_given(&signature.name, param, of, written);
                    failed |= found.is_none();
                    behaviors.extend(found);
                }
                (Some(_), ..) => {
                    self.missing_behavior(&signature.name, param, span);
                    failed = true;
                }
                (None, ty @ (Type::List(..) | Type::Map(..)), Some(place), Some(written)) => {
                    let (value, capacity) = self.of_any_capacity(written, ty);
                    capacities[place] = capacities[place].max(capacity);
                    given.push(Some(Given::Known(value)));
                }
                (None, .., written) => given.push(written.map(Given::Written)),
            }
        }
        let params = match template.capacities.is_empty() {
            true => signature.params.clone(),
            false => self.params_for(template.module, template.activity, named(&template.capacities, &capacities)),
        };
        let values_of: Vec<ParamInfo> = params.iter().filter(|param| param.behavior.is_none()).cloned().collect();
        let values = self.values(&signature.name, &values_of, given, failed, places)?;
        let (result, signature) = (signature.result.clone(), Signature { params: values_of, ..signature });
        if self.scope.is_nominal {
            return Some((Action::Call(id, values), result));
        }
        let made = Made { id: 0, of: id, params, behaviors, capacities, called: span };
        Some((Action::Call(self.made_with(made, signature)?, values), result))
    }

    fn missing_behavior(&mut self, what: &str, param: &ParamInfo, span: Span) {
        let message = format!("`{what}` needs `{}`, a behavior", param.name);
        let finding = Diagnostic::error(Code::ArgsMissing, span, message).label(param.span, "declared here");
        self.report(finding.help(format!("write `{}: BEHAVIOR`, by its name alone", param.name)));
    }

    /// The behavior that is written for a parameter, if it takes what that is called with.
    fn behavior_given(
        &mut self,
        what: &str,
        param: &ParamInfo,
        BehaviorType { takes, result }: &BehaviorType,
        written: &tree::Expr,
    ) -> Option<ActivityId> {
        let handed_on = match &written.kind {
            tree::ExprKind::Name(name) => self.use_given(name, written.span),
            _ => None,
        };
        let named = match &written.kind {
            _ if let Some(given) = &handed_on => Some(given.id),
            tree::ExprKind::Name(_) | tree::ExprKind::Member(..) => match self.find(written) {
                Found::Def(Def::Activity(id)) if !self.overlay_ids.contains(&id) && !self.mission_ids.contains(&id) => {
                    Some(id)
                }
                _ => None,
            },
            _ => None,
        };
        if let (tree::ExprKind::Name(name), None) = (&written.kind, named)
            && self.is_unknown(name)
        {
            self.name(name, written.span);
            return None;
        }
        let Some(id) = named else {
            let message = format!("`{}` of `{what}` is a behavior, this is none", param.name);
            let finding = Diagnostic::error(Code::TypesBehavior, written.span, message);
            self.report(
                finding
                    .help("write the name of a behavior or a strategy, without what it takes: `at_each: look_round`"),
            );
            return None;
        };
        let given = self.activity_signature(id).clone();
        // What is handed on has the result that its own parameter names, and that was looked at where that is declared.
        let own_result = handed_on.as_ref().map_or_else(|| given.result.clone(), |given| given.result.clone());
        let is_told = handed_on.is_some() && !self.scope.is_nominal;
        let wrong = self.misfit(&given, param, takes).or_else(|| {
            let wants = result.as_ref().filter(|wants| !is_told && own_result.as_ref() != Some(*wants))?;
            let wants = article(&self.type_name(wants));
            let has = own_result.as_ref().map_or("no result".to_string(), |has| article(&self.type_name(has)));
            Some(format!("`{}` has {has}, and of `{}` {wants} is read", given.name, param.name))
        });
        if let Some(message) = wrong {
            let finding = Diagnostic::error(Code::TypesBehavior, written.span, message);
            let wants = self.behavior_type(takes, result.as_ref());
            let finding = finding.label(param.span, "it is called with this").label(given.span, "declared here");
            self.report(finding.help(format!("give it a `{wants}`")));
            return None;
        }
        Some(id)
    }

    /// How a behavior that is asked for is written.
    fn behavior_type(&self, takes: &[Type], result: Option<&Type>) -> String {
        let takes: Vec<String> = takes.iter().map(|ty| self.type_name(ty)).collect();
        let result = result.map_or(String::new(), |ty| format!(" -> {}", self.type_name(ty)));
        format!("behavior({}){result}", takes.join(", "))
    }

    /// What of a behavior does not fit what it is called with.
    fn misfit(&self, given: &Signature, param: &ParamInfo, takes: &[Type]) -> Option<String> {
        let wrong = takes.iter().enumerate().find_map(|(i, ty)| match given.params.get(i) {
            None => Some(format!(
                "`{}` takes {}, and `{}` gives it {}",
                given.name,
                given.params.len(),
                param.name,
                takes.len()
            )),
            Some(own) if own.behavior.is_some() => {
                Some(format!("`{}` of `{}` is a behavior, and `{}` gives it none", own.name, given.name, param.name))
            }
            Some(own)
                if own.ty != *ty
                    && own.ty != ty.clone().optional()
                    && own.ty != Type::Unknown
                    && *ty != Type::Unknown =>
            {
                let (has, wants) = (self.type_name(ty), self.type_name(&own.ty));
                Some(format!(
                    "`{}` of `{}` is {}, and `{}` gives it {}",
                    own.name,
                    given.name,
                    article(&wants),
                    param.name,
                    article(&has)
                ))
            }
            Some(_) => None,
        });
        let more = given.params.iter().skip(takes.len()).find(|own| own.default.is_none());
        wrong.or_else(|| {
            more.map(|own| {
                format!("`{}` of `{}` has no default, and `{}` gives it nothing", own.name, given.name, param.name)
            })
        })
    }

    /// The behavior that is made of another with what it is given.
    fn made_with(&mut self, made: Made, signature: Signature) -> Option<ActivityId> {
        let key = (made.of, made.behaviors.clone(), made.capacities.clone());
        if let Some(made) = self.activity_templates.made.get(&key) {
            return Some(*made);
        }
        if self.activity_templates.made.len() >= INSTANCES_MAX {
            let message =
                format!("behaviors are called with more than {INSTANCES_MAX} behaviors and capacities of lists");
            let finding = Diagnostic::error(Code::LimitsCapacities, made.called, message);
            self.report(finding.help("give the same ones, or `match` on an enum in one of them"));
            return None;
        }
        let id = self.made_activity(signature);
        self.activity_templates.made.insert(key, id);
        self.activity_templates.ahead.push(Made { id, ..made });
        Some(id)
    }

    /// Whether anything is made of it.
    pub(super) fn is_made_of(&self, id: ActivityId) -> bool {
        self.activity_templates.made.keys().any(|(of, ..)| *of == id)
    }

    /// The bodies of what calls have made. What is wrong with one only with what it is given is told where that is.
    pub(super) fn check_made_activities(&mut self) {
        while let Some(made) = self.activity_templates.ahead.pop() {
            let Some(ActivityTemplate { module, activity: a, capacities }) =
                self.activity_templates.of.get(&made.of).cloned()
            else {
                continue;
            };
            let before = self.findings.len();
            let capacities = named(&capacities, &made.capacities);
            self.activity_with(module, made.id, a, (made.params, &made.behaviors, capacities));
            let found: Vec<Diagnostic> = self.findings.drain(before..).collect();
            self.inherited_findings
                .extend(found.into_iter().map(|finding| (finding, made.called, "with what this is given")));
        }
    }

    /// An activity as it is declared, with what stands in for what it is given.
    pub(super) fn declared_activity(&mut self, m: usize, id: ActivityId, a: &'t tree::Activity) {
        let params = self.activity_signatures[id].params.clone();
        let stand_ins = self.stand_ins(&params);
        let capacities =
            self.activity_templates.of.get(&id).map(|template| nominal(&template.capacities)).unwrap_or_default();
        let is_several = self.activity_templates.of.contains_key(&id);
        self.as_declared(Declared::Activity(id), is_several, |c| {
            c.activity_with(m, id, a, (params, &stand_ins, capacities));
        });
    }

    /// An activity with what it is given: its parameters, those that are behaviors, and the capacities of its lists.
    fn activity_with(
        &mut self,
        m: usize,
        id: ActivityId,
        a: &'t tree::Activity,
        (infos, behaviors, capacities): (Vec<ParamInfo>, &[ActivityId], Capacities),
    ) {
        let Signature { name, span, .. } = self.activity_signature(id).clone();
        let is_nominal = self.activity_templates.of.contains_key(&id);
        let scope = Scope { derived: self.derived(a), capacities, is_nominal, ..Scope::new(m, Setting::Body) };
        let ((mut activity, params), scope) = self.within(scope, |c| {
            c.declare_params(&a.params, &infos);
            let results = infos.iter().filter_map(|info| info.behavior.as_ref()).map(|of| of.result.clone());
            let given = a.params.iter().filter(|param| is_behavior(param)).zip(results).zip(behaviors);
            given.for_each(|((param, result), given)| c.declare_behavior(&param.name, result, *given));
            let params = c.scope.vars.len();
            for known in c.modules[m].known.iter().flatten() {
                let id = c.declare_hidden(known.name.clone(), known.kind(), known.ty.clone(), span);
                c.scope.vars[id].range = known.range;
            }
            (c.activity(id, a, None), params)
        });
        activity.name = a.name.node.clone();
        activity.full_name = name;
        activity.vars = scope.vars;
        activity.params = params;
        let values = infos.into_iter().filter(|param| param.behavior.is_none());
        activity.defaults = values.map(|param| param.default).collect();
        self.hir.activities[id] = activity;
    }
}

/// Capacities by their names.
fn named(names: &[String], capacities: &[u32]) -> Capacities {
    names.iter().cloned().zip(capacities.iter().copied()).collect()
}

/// The capacities with which one is checked though nobody calls it.
fn nominal(names: &[String]) -> Capacities {
    names.iter().map(|name| (name.clone(), NOMINAL)).collect()
}
